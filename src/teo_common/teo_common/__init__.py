# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What the packages share: text folding, atomic files, package data, parameters, diagnostics, running a node.

`teo_common.node_process` (running a node) and `teo_common.mcap_salvage` (reading cut-off MCAP files) are
imported by name where they are needed: they need rclpy and mcap.
"""

from teo_common.atomic_files import atomic_path, write_atomically
from teo_common.diagnostics import (
    DIAGNOSTICS_PERIOD,
    Diagnosis,
    DiagnosticsPublisher,
    Level,
    RateMeter,
    RateReport,
)
from teo_common.package_files import package_path
from teo_common.parameters import ParameterRow, declare_parameters
from teo_common.text_folding import fold, folded, strip_marks, without_accents

__all__ = [
    "DIAGNOSTICS_PERIOD",
    "Diagnosis",
    "DiagnosticsPublisher",
    "Level",
    "ParameterRow",
    "RateMeter",
    "RateReport",
    "atomic_path",
    "declare_parameters",
    "fold",
    "folded",
    "package_path",
    "strip_marks",
    "without_accents",
    "write_atomically",
]
