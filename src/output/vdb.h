// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <openvdb/openvdb.h>

#include <ostream>

namespace leafhull {

/// Writes an OpenVDB file with this one grid; the same grid gives the same bytes. Exceptions of the
/// stream pass through.
void write_vdb(const openvdb::FloatGrid::ConstPtr& grid, std::ostream& stream);

}  // namespace leafhull
