"""The paper as functions, which know no file and no claim. The example: a pendulum."""
