#pragma once

// vectors, matrices and quaternions: the solids, which know nothing of the kernel, bring them
#include "lsdem/solid/vectors.hpp"
