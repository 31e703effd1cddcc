"""Digital twins of rotors and pendulums."""
