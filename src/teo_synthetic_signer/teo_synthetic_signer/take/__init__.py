"""One person, in one room, plays one script before one sensor: images with truth, and their bag."""
