#pragma once

namespace cdfp {

/// glibc keeps large blocks that were freed, and more of them the larger they were: a tenth of a run's
/// memory. A program calls this at its start to have them go back to the system.
void give_large_blocks_back();

}  // namespace cdfp
