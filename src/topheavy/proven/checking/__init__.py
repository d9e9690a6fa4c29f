"""A second proof of a certificate that shares no code with the search."""
