# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The console: a page in the browser that shows what TEO signs, and the node that serves it."""
