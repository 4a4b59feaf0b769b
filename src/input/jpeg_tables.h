// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "input/file_bytes.h"

namespace leafhull {

/// Whether the Huffman tables of a JPEG file hold no more codes than there are bytes, and those
/// that its scans use are there, as are its quantisation tables. stb_image takes that for granted:
/// before version 2.29 it writes past the end of larger tables, and what is not there is whatever
/// the memory held.
bool has_sound_tables(ByteSpan jpeg);

}  // namespace leafhull
