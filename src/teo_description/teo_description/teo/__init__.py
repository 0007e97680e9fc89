# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What is TEO's alone: how `teo.urdf` is written from published figures, and what its real hands are told."""
