"""What stands on level surfaces, from one depth image: surfaces, what rises from them, its size.

Nothing is named here, and nothing of the robot reads it yet.
"""
