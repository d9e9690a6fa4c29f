"""What a run is given: strict YAML, configs with their schemas, the parts of the work."""
