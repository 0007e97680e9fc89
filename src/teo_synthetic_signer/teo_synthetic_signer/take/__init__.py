"""One person, in one room, plays one script before one sensor; as images with truth, and as a bag."""
