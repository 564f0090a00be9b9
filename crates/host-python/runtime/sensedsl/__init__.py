"""What all generated packages share; copied, not generated."""
