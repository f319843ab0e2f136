// SPDX-License-Identifier: BSD-3-Clause
#include "config/yaml_number.h"

#include <fmt/format.h>

namespace hexcal {

std::string YamlNumber(double value) {
  std::string text = fmt::format("{}", value);
  const std::size_t exponent = text.find('e');
  if (exponent != std::string::npos && text.find('.') == std::string::npos)
    text.insert(exponent, ".0");
  return text;
}

std::string YamlNumbers(const double* values, int size) {
  std::string text = "[";
  for (int i = 0; i < size; ++i) text += (i == 0 ? "" : ", ") + YamlNumber(values[i]);
  return text + "]";
}

}  // namespace hexcal
