"""Where the arm is: forward kinematics, Jacobian, inverse kinematics."""
