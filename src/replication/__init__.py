"""What the steps, figures and documents share."""
