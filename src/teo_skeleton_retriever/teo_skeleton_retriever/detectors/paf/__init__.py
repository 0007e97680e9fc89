"""OpenPose's method, part affinity fields, with a network that the user brings as an ONNX file."""
