# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What every page shows, made from what the nodes say, with time as an argument."""
