// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>

#include "cli/table.h"
#include "cli/verb.h"
#include "leafhull/error.h"

namespace leafhull::cli {
namespace {

void print_table(const std::vector<DeviceInfo>& devices) {
  std::vector<std::vector<std::string>> rows = {
      {"index", "name", "platform", "type", "variant", "cores", "memory", "chosen", "why"}};
  for (std::size_t i = 0; i < devices.size(); ++i) {
    const DeviceInfo& d = devices[i];
    rows.push_back({std::to_string(i), d.name, d.platform, d.type, d.variant,
                    std::to_string(d.compute_units), std::to_string(d.memory_bytes >> 20) + " MiB",
                    d.chosen ? "yes" : "no", d.reason});
  }
  std::cout << table(rows);
}

void print_json(const std::vector<DeviceInfo>& devices) {
  auto list = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < devices.size(); ++i) {
    const DeviceInfo& d = devices[i];
    list.push_back({{"index", i},
                    {"name", d.name},
                    {"platform", d.platform},
                    {"version", d.version},
                    {"driver", d.driver},
                    {"type", d.type},
                    {"variant", d.variant},
                    {"compute_units", d.compute_units},
                    {"memory_bytes", d.memory_bytes},
                    {"usable", d.usable},
                    {"chosen", d.chosen},
                    {"reason", d.reason}});
  }
  std::cout << nlohmann::ordered_json{{"devices", list}}.dump(2) << '\n';
}

void run_devices(const Arguments& arguments) {
  const std::vector<DeviceInfo> devices = list_devices(arguments.device);
  if (arguments.json) {
    print_json(devices);
  } else if (!devices.empty()) {
    print_table(devices);
  }
  const auto usable = [](const DeviceInfo& device) { return device.usable; };
  if (std::none_of(devices.begin(), devices.end(), usable)) {
    throw Error(ErrorCode::device, "no usable OpenCL device was found",
                "PoCL turns the CPU into one: apt-get install pocl-opencl-icd");
  }
  const auto chosen = [](const DeviceInfo& device) { return device.chosen; };
  if (std::none_of(devices.begin(), devices.end(), chosen)) {
    throw Error(ErrorCode::device,
                "no usable OpenCL device matches '" + arguments.device.choice + "'",
                "Give --device an index or part of a name listed by leafhull devices.");
  }
}

}  // namespace

Verb devices_verb() {
  return {.name = "devices",
          .summary = "the OpenCL devices, and which one would be used",
          .about = "Lists the OpenCL devices, which one leafhull would use, and why.",
          .examples =
              "  leafhull devices\n"
              "  leafhull devices --device pocl --json\n",
          .flags = all_of({device_flags(), json_flags(), help_flags()}),
          .run = run_devices};
}

}  // namespace leafhull::cli
