"""What rocks: columns, frames, a mass fixed to them; how they move and what a history of it is."""
