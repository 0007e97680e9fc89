# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Whether what ``robot.yaml`` says of a robot is true: what `robots check` looks at."""
