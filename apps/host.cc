// SPDX-License-Identifier: BSD-3-Clause
#include "apps/host.h"

#include <sys/utsname.h>
#include <unistd.h>

#include <algorithm>

namespace hexcal {

Host ThisHost() {
  Host host;
  utsname names = {};
  if (uname(&names) == 0) {
    host.name = names.nodename;
    host.system = std::string(names.sysname) + " " + names.release + " " + names.machine;
  }
  host.processors = static_cast<int>(std::max(sysconf(_SC_NPROCESSORS_ONLN), 0L));
  return host;
}

}  // namespace hexcal
