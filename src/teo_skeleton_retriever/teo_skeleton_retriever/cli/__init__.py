"""Commands that need no ROS running: `retrieve`, and the way to those of `teo_synthetic_signer`."""
