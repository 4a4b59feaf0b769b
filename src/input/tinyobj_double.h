// SPDX-License-Identifier: Apache-2.0
#pragma once

// tinyobjloader in double precision. It would have the same symbols as the one with floats, so it
// gets a namespace of its own: a program may use leafhull and tinyobjloader.
#define TINYOBJLOADER_USE_DOUBLE
#define tinyobj tinyobj_double
#include <tiny_obj_loader.h>
#undef tinyobj
