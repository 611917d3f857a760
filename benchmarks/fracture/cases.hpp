/// The fracture benchmarks, one a file: each prints its figures and leaves a picture.
#pragma once

namespace bench {

void expanding_bar();
void spall();
void strip();
void double_cantilever();
void kalthoff();
void branching();
void mesh_angle();

}  // namespace bench
