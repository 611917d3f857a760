/// Highest squared frequency of a single free element: what bounds the stable step of any assembly of it.
#pragma once

#include "element/block.hpp"
#include "element/geometry.hpp"

namespace cdfp {

/// omega^2 <= max(material, hourglass) + coupling sqrt(material hourglass) of the undeformed element (1/s2).
/// material: exact for the uniform strains; hourglass: for the rest; coupling: of their subspaces (Kittaneh
/// 1997), zero for parallelepipeds. geometric: times a stress in Pa, it bounds what that stress adds.
struct StepTerms {
  double material = 0, hourglass = 0, coupling = 0, geometric = 0;
  double bound() const;
};

/// material and geometric of a mean gradient whose squares sum up to `metric` over the corners.
StepTerms mean_terms(const Eigen::Matrix3d& metric, int corners, const PartConstants& part, double density);
StepTerms tetrahedron_terms(const TetrahedronGeometry& geometry, const PartConstants& part, double density);
StepTerms one_point_terms(const HexahedronGeometry& geometry, const PartConstants& part,
                          const Eigen::Vector3d& hourglass, double density);
StepTerms full_terms(const HexahedronGeometry& geometry, const PartConstants& part, double density);

/// Without slack, by solving the eigenproblem of the element.
double full_exact(const HexahedronGeometry& geometry, const PartConstants& part, double density);
double one_point_exact(const HexahedronGeometry& geometry, const PartConstants& part,
                       const Eigen::Vector3d& hourglass, double density);

template <class Symmetric>
double highest_eigenvalue(const Symmetric& matrix) {
  return Eigen::SelfAdjointEigenSolver<Symmetric>(matrix, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
}

}  // namespace cdfp
