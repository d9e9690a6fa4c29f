"""What is read: captions, the documents, and the published edition."""
