"""The forces at the contacts of rocking frames, and those in a frame clamped against uplift."""
