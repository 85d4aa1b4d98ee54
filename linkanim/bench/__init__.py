"""Speed against error: this solver beside the usual ways of solving a linkage, measured in one run."""
