"""The forces at the contacts of frames and portals, and those in a frame that is held."""
