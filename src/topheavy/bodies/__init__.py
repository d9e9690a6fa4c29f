"""Columns, frames and fixed masses: their dimensions, rocking blocks, kinematics and energy."""
