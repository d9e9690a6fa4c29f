"""What shakes them: pulses, records and their reading, synthetic motions, a shaking table."""
