/// Hot loops are compiled for several instruction sets and chosen at start.
#pragma once

namespace cdfp {

enum class InstructionSet { baseline, avx2, avx512 };

/// The best that this processor and this build have. The environment variable CDFP_ISA (baseline, avx2 or
/// avx512) may name a lesser one; throws `Error(bad_argument)` for another word or a set that the processor
/// lacks.
InstructionSet choose_instruction_set();

}  // namespace cdfp
