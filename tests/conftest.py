"""Hypothesis profiles, chosen by HYPOTHESIS_PROFILE or --hypothesis-profile.

default: few examples, always the same. thorough: many, always the same. search: many, new ones in
every run; what it finds becomes an @example.
"""

import os

from hypothesis import settings

settings.register_profile("default", derandomize=True, deadline=None, max_examples=50)
settings.register_profile("thorough", derandomize=True, deadline=None, max_examples=1000)
settings.register_profile("search", deadline=None, max_examples=1000, print_blob=True)
settings.load_profile(os.environ.get("HYPOTHESIS_PROFILE", "default"))
