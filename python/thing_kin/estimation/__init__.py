"""Where the base is, where the hand is, and how sure we are."""
