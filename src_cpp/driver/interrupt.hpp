/// Ctrl-C and SIGTERM as a wish to finish the step and close the files.
#pragma once

namespace cdfp {

/// A second signal ends the process at once.
void watch_interrupts();
bool interrupted();

}  // namespace cdfp
