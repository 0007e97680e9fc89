"""From colour and depth images to 3D keypoints of people: the parts that know nothing of ROS."""
