# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`retriever_node`: its parameters and subscriptions, its work in threads, and its diagnostics."""
