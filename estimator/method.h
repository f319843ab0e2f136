// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string_view>

#include "estimator/calibrate.h"
#include "estimator/marker_observations.h"

namespace hexcal {

// The ways to base and tool that hexcal compare sets side by side.
enum class Method {
  kPaper,
  kTwist,
  kZhuang,
  kShah,
  kLi,
  kParkMartin,
  kNonlinear,
  kMarker,
  kRobust
};

struct MethodInfo {
  Method method;
  std::string_view name;   // in compare.json
  std::string_view title;  // in the table
};
inline constexpr std::array<MethodInfo, 9> kMethods = {
    {{Method::kPaper, "paper", "paper's iteration"},
     {Method::kTwist, "twist", "twist iteration"},
     {Method::kZhuang, "zhuang", "Zhuang (AX=YB)"},
     {Method::kShah, "shah", "Shah"},
     {Method::kLi, "li", "Li"},
     {Method::kParkMartin, "park_martin", "Park-Martin"},
     {Method::kNonlinear, "nonlinear", "nonlinear"},
     {Method::kMarker, "marker", "by marker"},
     {Method::kRobust, "robust", "without outliers"}}};

const MethodInfo& InfoOf(Method method);

struct MethodFit {
  BaseAndTool mounts;
  bool converged = true;  // closed forms: always
  std::string message;
  std::vector<IterationRecord> iterations;  // closed forms: none
};

// The readings that some of the poses were made of; empty where there are none, and no kMarker.
using MarkersOf = std::function<MarkerObservations(const Observations&)>;

// options: those of calibrate; the iterations start as it would have them, and outliers are sought
// by kRobust alone. What a method cannot do (a base of half a turn for Zhuang's) comes out as it
// comes out.
MethodFit Fit(Method method,
              const Observations& observations,
              const std::optional<BaseAndTool>& initial,
              const CalibrateOptions& options,
              const MarkersOf& markers = {});

}  // namespace hexcal
