"""What all tests share."""

import pytest


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_setupnodes():
    """Compile the kernel before several processes need it at the same time."""
    from steps.kernel import compute

    compute()
