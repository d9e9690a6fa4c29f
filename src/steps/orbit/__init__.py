"""The steady rocking of a block on a shaking table, proven by one program."""
