#define DOCTEST_CONFIG_IMPLEMENT_WITH_MAIN
#define DOCTEST_CONFIG_IMPLEMENT  // which follows from the line above only where doctest.h is not precompiled
#include <doctest/doctest.h>
