# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A person: mesh, rig, shape, clothes, the places that hands go to, and the skin of a pose."""
