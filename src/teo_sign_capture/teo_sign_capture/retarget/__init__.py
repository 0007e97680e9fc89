"""A person's motion as a motion of the robot.

Where hands belong, arms, fingers, head, distances to the body, knots.
"""
