// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <deque>
#include <functional>
#include <future>
#include <thread>

namespace hexcal {

// Threads for a wish of the user's; 0: as many as there are processors.
inline int ThreadsFor(int wish) {
  return wish > 0 ? wish : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

// Works on tasks 0..count-1, at most threads at a time, and hands each result to consume, in the
// calling thread and in the tasks' order, so that nothing that is written depends on the number of
// threads. An exception of work comes out of consume's place; tasks under way are waited for.
template <typename Result>
void ForEachInOrder(std::size_t count,
                    int threads,
                    const std::function<Result(std::size_t)>& work,
                    const std::function<void(std::size_t, Result)>& consume) {
  std::deque<std::future<Result>> running;
  std::size_t next = 0;
  for (std::size_t done = 0; done < count; ++done) {
    for (; next < count && running.size() < static_cast<std::size_t>(threads); ++next)
      running.push_back(std::async(std::launch::async, work, next));
    Result result = running.front().get();
    running.pop_front();
    consume(done, std::move(result));
  }
}

}  // namespace hexcal
