"""What a sign is captured from: bags of skeletons or images, `.pose` clips, live skeletons."""
