"""The paper, as functions. The example: a pendulum that swings far. It knows no file and no claim."""
