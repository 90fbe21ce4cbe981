"""What a map of Juno says with ankles of two rods each, and a differential at its waist."""

ANKLES = """
linkages:
  left_ankle: {type: rods, joints: [left_ankle_pitch, left_ankle_roll], rods: [
    {motor_at_m: [0, 0.03, 0.2], crank_m: 0.05, rod_m: 0.22, foot_at_m: [-0.05, 0.03, -0.02]},
    {motor_at_m: [0, -0.03, 0.28], crank_m: 0.05, rod_m: 0.3, foot_at_m: [-0.05, -0.03, -0.02]}]}
  right_ankle: {type: rods, joints: [right_ankle_pitch, right_ankle_roll], rods: [
    {motor_at_m: [0, 0.03, 0.28], crank_m: 0.05, rod_m: 0.3, foot_at_m: [-0.05, 0.03, -0.02]},
    {motor_at_m: [0, -0.03, 0.2], crank_m: 0.05, rod_m: 0.22, foot_at_m: [-0.05, -0.03, -0.02]}]}
  waist: {type: belts, joints: [waist_roll, waist_pitch], turns: [[1, 1], [1, -1]]}
"""
