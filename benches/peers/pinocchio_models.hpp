// The chain and the arm as models of Pinocchio, numbers typed in from README.md and machines/six_joint_arm.machine.
#pragma once
#include <pinocchio/multibody/joint.hpp>
#include <pinocchio/multibody.hpp>
#include <pinocchio/algorithm/aba.hpp>

#include <stdexcept>
#include <string>

struct Machine {
    pinocchio::Model model;
    bool absolute;   // whether the state holds absolute angles
    double friction; // N m s
};

inline Machine machine_of(const std::string& task) {
    using namespace pinocchio;
    using Eigen::Matrix3d;
    using Eigen::Vector3d;
    Machine machine{Model(), false, 0.0};
    Model& model = machine.model;
    JointIndex parent = 0;
    if (task.rfind("chain", 0) == 0) {
        // In the plane x, z. A turn about y takes the downward vertical towards -x: the mirror image, with the same
        // equations.
        machine.absolute = true;
        const int n = std::stoi(task.substr(5));
        double before = 0;
        for (int i = 0; i < n; ++i) {
            const double length = 0.4 + 0.05 * (i % 5), rod = 0.8 + 0.1 * (i % 3), point = 0.5 + 0.1 * (i % 4);
            const double mass = rod + point, centre = (rod * length / 2 + point * length) / mass;
            const double inertia = rod * length * length / 12 + rod * (centre - length / 2) * (centre - length / 2)
                                   + point * (length - centre) * (length - centre);
            const SE3 placement(Matrix3d::Identity(), Vector3d(0, 0, -before));
            parent = model.addJoint(parent, JointModelRY(), placement, "joint" + std::to_string(i));
            Matrix3d about = Matrix3d::Zero();
            about(1, 1) = inertia;
            about(0, 0) = inertia; // no part in the plane's motion; a rod has it
            model.appendBodyToJoint(parent, Inertia(mass, Vector3d(0, 0, -centre), about), SE3::Identity());
            before = length;
        }
        model.gravity.linear(Vector3d(0, 0, -9.81));
        return machine;
    }
    if (task != "arm") throw std::invalid_argument(task);
    const double h = 0.35, a = 0.40, b = 0.42, c = 0.10;
    machine.friction = 0.4;
    struct Link {
        char axis;
        Vector3d shift;
        double mass;
        Vector3d centre;
        double xx, yy, zz, xy, xz, yz;
    };
    const Link links[] = {
        {'z', {0, 0, 0}, 12, {0, -0.01, h / 2}, 0.25, 0.25, 0.06, 0, 0, 0},
        {'y', {0, 0, h}, 9, {0, 0.03, a / 2}, 0.13, 0.13, 0.02, 0, 0, 0},
        {'y', {0, 0, a}, 6, {0.01, 0, b / 2}, 0.09, 0.09, 0.01, 0, 0, 0.002},
        {'z', {0, 0, b}, 1.5, {0, 0, 0}, 0.003, 0.003, 0.002, 0, 0, 0},
        {'y', {0, 0, 0}, 1, {0, 0, c / 2}, 0.002, 0.002, 0.001, 0, 0, 0},
        {'z', {0, 0, c}, 5.2, {0.03, 0, 0.08}, 0.02, 0.02, 0.01, 0.001, 0, 0},
    };
    for (int i = 0; i < 6; ++i) {
        const Link& link = links[i];
        const SE3 placement(Matrix3d::Identity(), link.shift);
        const std::string name = "joint" + std::to_string(i);
        parent = link.axis == 'z' ? model.addJoint(parent, JointModelRZ(), placement, name)
                                  : model.addJoint(parent, JointModelRY(), placement, name);
        Matrix3d about;
        about << link.xx, link.xy, link.xz, link.xy, link.yy, link.yz, link.xz, link.yz, link.zz;
        model.appendBodyToJoint(parent, Inertia(link.mass, link.centre, about), SE3::Identity());
    }
    model.gravity.linear(Vector3d(0, 0, -9.81));
    return machine;
}
