"""What the paper leaves open: our choices, the alternatives, and the quantities they reach."""
