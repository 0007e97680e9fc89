"""`retriever_node`: its parameters and subscriptions, its work in threads, and its diagnostics."""
