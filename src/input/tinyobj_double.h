// SPDX-License-Identifier: Apache-2.0
#pragma once

// tinyobjloader in double precision. Built with doubles it has the same symbols as with floats, so
// here it gets a name of its own: a program may use leafhull and the other one.
#define TINYOBJLOADER_USE_DOUBLE
#define tinyobj tinyobj_double
#include <tiny_obj_loader.h>
#undef tinyobj
