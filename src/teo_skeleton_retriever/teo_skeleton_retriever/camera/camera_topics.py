"""What the topics of a depth camera are called, without the leading slash; the RealSense driver's names."""

COLOR = "camera/color/image_raw"
DEPTH = "camera/aligned_depth_to_color/image_raw"
CAMERA_INFO = "camera/color/camera_info"
