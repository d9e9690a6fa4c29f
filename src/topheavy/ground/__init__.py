"""What shakes them: pulses, records and their reading."""
