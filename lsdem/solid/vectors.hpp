#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

/// LS-DEM kernel: rigid blocks in dry frictional contact. Plain SI doubles; the only dependency is Eigen.
namespace musim::lsdem {

using Vector3 = Eigen::Vector3d;
using Matrix3 = Eigen::Matrix3d;
using Quaternion = Eigen::Quaterniond;

}  // namespace musim::lsdem
