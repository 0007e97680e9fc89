"""What a sign is captured from.

Bags of images or skeletons, `.pose` clips, clips of letters, live skeletons.
"""
