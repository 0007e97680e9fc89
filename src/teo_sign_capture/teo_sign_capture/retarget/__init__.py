"""A person's motion as a motion of the robot: hands, arms, head, contact, collisions."""
