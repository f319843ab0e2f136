// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gflags/gflags_declare.h>

#include <limits>
#include <string>
#include <string_view>
#include <vector>

DECLARE_string(out);
DECLARE_string(model);
DECLARE_string(config);
DECLARE_string(solver);
DECLARE_string(residual);
DECLARE_string(start);
DECLARE_string(evaluation);
DECLARE_string(outliers);
DECLARE_string(loss);
DECLARE_double(loss_scale);
DECLARE_string(covariance);
DECLARE_string(error);
DECLARE_string(unit_magnitude);
DECLARE_int32(iterations);
DECLARE_double(tolerance);
DECLARE_double(noise_position);
DECLARE_double(noise_orientation);
DECLARE_double(noise);
DECLARE_int64(seed);
DECLARE_int32(folds);
DECLARE_double(alpha);
DECLARE_int32(bootstraps);
DECLARE_int32(draws);
DECLARE_int32(starts);
DECLARE_string(robot);
DECLARE_string(robot_format);
DECLARE_string(robot_rotation);
DECLARE_string(robot_columns);
DECLARE_bool(robot_inverse);
DECLARE_bool(measured_inverse);
DECLARE_string(base);
DECLARE_string(tool);
DECLARE_string(base_body);
DECLARE_string(tool_body);
DECLARE_string(kind);
DECLARE_string(pair);
DECLARE_int32(frames);
DECLARE_double(stops);
DECLARE_double(window);
DECLARE_double(time_offset);
DECLARE_double(missing_value);
DECLARE_bool(static_tracker);
DECLARE_string(hexapod);
DECLARE_string(initial);
DECLARE_string(map);
DECLARE_string(dataset);
DECLARE_string(world_frame);
DECLARE_string(base_frame);
DECLARE_string(platform_frame);
DECLARE_string(tool_frame);
DECLARE_string(robot_map);
DECLARE_string(name);
DECLARE_string(units);
DECLARE_string(for);
DECLARE_int32(poses);
DECLARE_int32(pool);
DECLARE_string(settings);
DECLARE_string(requirement);
DECLARE_string(previous);
DECLARE_bool(gate);
DECLARE_string(task);
DECLARE_bool(merge);
DECLARE_bool(retry);
DECLARE_string(history);
DECLARE_string(operator);
DECLARE_string(head);
DECLARE_int32(since);
DECLARE_int32(baseline);
DECLARE_int32(threads);
DECLARE_bool(report);
DECLARE_bool(json);
DECLARE_bool(quiet);
DECLARE_bool(force);

namespace hexcal {

// What gflags does not know of a flag: which values it may take and how help shows it. Parsing,
// help and error messages all read this table; type, default and description come from gflags.
struct FlagSpec {
  std::string_view name;
  std::string_view group;         // the heading in help
  std::string_view value;         // stands for the value in help; a switch has none
  std::string_view default_text;  // in words, where gflags' default is not one
  std::vector<std::string_view> choices = {};
  double low = -std::numeric_limits<double>::infinity();  // numbers: the range, both ends allowed
  double high = std::numeric_limits<double>::infinity();
  bool low_excluded = false;
  std::string_view together_with = {};  // the other flag without which this one is wrong usage
  // Wrong usage on the command line unless that other flag has that value.
  std::string_view only_with_flag = {};
  std::string_view only_with_value = {};
};

const std::vector<FlagSpec>& FlagSpecs();
const FlagSpec* FindFlag(std::string_view name);  // nullptr: no flag of hexcal

}  // namespace hexcal
