"""The rocking frame of Makris & Vassiliou (2014) as a solitary rocking column."""
