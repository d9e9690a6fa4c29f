"""Ground motions: pulses, records, and files of records."""
