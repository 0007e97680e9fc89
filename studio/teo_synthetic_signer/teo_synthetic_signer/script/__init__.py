# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What a person does: key poses in words, the motion between them, scripts and their files."""
