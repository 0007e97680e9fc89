# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Commands that need no ROS running: `retrieve`, and the way to those of `teo_synthetic_signer`."""
