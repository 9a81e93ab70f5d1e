// Pinocchio's articulated-body algorithm over casadi::SX for a robot from its file of URDF: writes the C of a function
// (q, v) -> a, and prints the numbers of coordinates and of rates, and the CPU seconds of deriving and of printing.
//
//     pinocchio_robot ROBOT.urdf fixed|free|angles local|world OUT
//
// A base that is `free` has a quaternion and the rates of its own axes, as Pinocchio's users have it; with `angles` it has a
// place, yaw, pitch and roll, and their rates. Dampers are those of the file, dry friction is left out.
#include <pinocchio/autodiff/casadi.hpp>
#include <pinocchio/algorithm/aba.hpp>
#include <pinocchio/multibody/joint.hpp>
#include <pinocchio/parsers/urdf.hpp>

#include <casadi/casadi.hpp>
#include <cstdio>
#include <ctime>
#include <fstream>

using casadi::SX;

static double seconds() { return double(std::clock()) / CLOCKS_PER_SEC; }

int main(int count, char** words) {
    if (count != 5) return 2;
    const std::string file = words[1], base = words[2], frame = words[3], out = words[4];
    const double start = seconds();
    pinocchio::Model numbers;
    if (base == "free") {
        pinocchio::urdf::buildModel(file, pinocchio::JointModelFreeFlyer(), numbers);
    } else if (base == "angles") {
        pinocchio::JointModelComposite root;
        root.addJoint(pinocchio::JointModelTranslation());
        root.addJoint(pinocchio::JointModelSphericalZYX());
        pinocchio::urdf::buildModel(file, root, numbers);
    } else {
        pinocchio::urdf::buildModel(file, numbers);
    }
    const auto model = numbers.cast<SX>();
    pinocchio::DataTpl<SX> data(model);
    const SX position = SX::sym("q", model.nq), rate = SX::sym("v", model.nv);
    Eigen::Matrix<SX, Eigen::Dynamic, 1> q(model.nq), v(model.nv), tau(model.nv);
    for (int i = 0; i < model.nq; ++i) q[i] = position(i);
    for (int i = 0; i < model.nv; ++i) {
        v[i] = rate(i);
        tau[i] = -numbers.damping[i] * v[i];
    }
    const auto convention = frame == "local" ? pinocchio::Convention::LOCAL : pinocchio::Convention::WORLD;
    pinocchio::aba(model, data, q, v, tau, convention);
    SX a = SX::zeros(model.nv);
    for (int i = 0; i < model.nv; ++i) a(i) = data.ddq[i];
    const casadi::Function function("f", {position, rate}, {SX::cse(std::vector<SX>{a})[0]});
    const double derived = seconds();
    casadi::CodeGenerator generator("f");
    generator.add(function);
    std::ofstream(out + ".c") << generator.dump();
    std::printf("%d %d %lld %.6f %.6f\n", model.nq, model.nv, (long long)function.n_instructions(), derived - start, seconds() - derived);
}
