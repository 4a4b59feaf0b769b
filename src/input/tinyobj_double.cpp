// SPDX-License-Identifier: Apache-2.0
#define TINYOBJLOADER_IMPLEMENTATION
#include "input/tinyobj_double.h"
