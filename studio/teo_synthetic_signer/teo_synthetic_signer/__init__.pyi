# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from .take.take import Companion as Companion
from .take.take import SyntheticFrame as SyntheticFrame
from .take.take import Take as Take
from .take.take import TakeOptions as TakeOptions
from .take.take import Truth as Truth
from .take.take import render_take as render_take
from .take.take_files import write_take as write_take
