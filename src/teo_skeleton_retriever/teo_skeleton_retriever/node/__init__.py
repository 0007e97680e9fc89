"""`retriever_node`: its parameters, its subscriptions, its work in threads and what it says of itself."""
