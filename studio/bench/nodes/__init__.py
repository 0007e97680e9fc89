# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What executor, driver and the whole graph do while they run: rates, first motion, floods, stops, faults."""
