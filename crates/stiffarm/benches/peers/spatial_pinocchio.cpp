// What a user would otherwise write: Pinocchio's Jacobian and Eigen's closed-form eigenvalues in C++, one thread.
// `spatial_pinocchio_cpp` builds and runs it; its only argument is the robot file with lengths and limits.

#include <pinocchio/multibody.hpp>
#include <pinocchio/algorithm/frames.hpp>
#include <pinocchio/algorithm/jacobian.hpp>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using Six = Eigen::Matrix<double, 6, 1>;

constexpr std::size_t POSTURES = 100'000;
constexpr int ROUNDS = 15;

// All numbers on the line `key = ...` of the robot file.
std::vector<double> numbers(const std::string& file, const std::string& key) {
    std::ifstream lines(file);
    for (std::string line; std::getline(lines, line);) {
        if (line.rfind(key + " =", 0) != 0) continue;
        std::replace_if(line.begin(), line.end(), [](char c) { return c == '[' || c == ']' || c == ','; }, ' ');
        std::istringstream rest(line.substr(line.find('=') + 1));
        return {std::istream_iterator<double>(rest), {}};
    }
    throw std::runtime_error(file + " has no line " + key);
}

// The arm upright at zero; its last frame is the flange.
pinocchio::Model arm(const std::string& file) {
    const auto m = [&](const char* key) { return 1e-3 * numbers(file, key).at(0); };
    const auto at = [](double x, double y, double z) {
        return pinocchio::SE3(Eigen::Matrix3d::Identity(), Eigen::Vector3d(x, y, z));
    };
    const auto here = pinocchio::SE3::Identity();
    const pinocchio::JointModelRY about_y;
    const pinocchio::JointModelRZ about_z;
    pinocchio::Model model;
    const auto body = model.addJoint(0, about_z, here, "joint 1");
    const auto upper_arm = model.addJoint(body, about_y, at(m("a1_mm"), m("b_mm"), m("c1_mm")), "joint 2");
    const auto forearm = model.addJoint(upper_arm, about_y, at(0, 0, m("c2_mm")), "joint 3");
    const auto tube = model.addJoint(forearm, about_z, at(m("a2_mm"), 0, m("c3_mm")), "joint 4");
    const auto hand = model.addJoint(tube, about_y, here, "joint 5");
    const auto last = model.addJoint(hand, about_z, here, "joint 6");
    model.addFrame(pinocchio::Frame("flange", last, at(0, 0, m("c4_mm")), pinocchio::OP_FRAME));
    return model;
}

// Random postures within the limits, as angles from the upright arm, rad.
std::vector<Eigen::VectorXd> postures(const std::string& file) {
    const auto limits = numbers(file, "joint_deg");
    const auto offset = numbers(file, "offset_deg");
    const auto sign = numbers(file, "sign");
    std::mt19937_64 random(1);
    std::vector<Eigen::VectorXd> all(POSTURES, Eigen::VectorXd(6));
    for (auto& q : all)
        for (int i = 0; i < 6; ++i) {
            const double reported = std::uniform_real_distribution<>(limits.at(2 * i), limits.at(2 * i + 1))(random);
            q[i] = (sign.at(i) * reported - offset.at(i)) * M_PI / 180;
        }
    return all;
}

}  // namespace

int main(int count, char** arguments) {
    if (count != 2) return 2;
    const auto model = arm(arguments[1]);
    const auto angles = postures(arguments[1]);
    const auto flange = model.getFrameId("flange");
    const Six drives = Six::Constant(1e-6);
    pinocchio::Data data(model);
    pinocchio::Data::Matrix6x jacobian(6, 6);
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen;
    std::vector<double> seconds;
    double sum = 0;
    for (int round = 0; round < ROUNDS; ++round) {
        const auto start = std::chrono::steady_clock::now();
        for (const auto& q : angles) {
            jacobian.setZero();
            pinocchio::computeFrameJacobian(model, data, q, flange, pinocchio::LOCAL_WORLD_ALIGNED, jacobian);
            const Eigen::Matrix<double, 3, 6> j = jacobian.topRows<3>();
            const Eigen::Matrix3d compliance = j * drives.asDiagonal() * j.transpose();
            sum += eigen.computeDirect(compliance, Eigen::EigenvaluesOnly).eigenvalues()[2];
        }
        seconds.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    }
    std::nth_element(seconds.begin(), seconds.begin() + ROUNDS / 2, seconds.end());
    std::fprintf(stderr, "mean of the largest compliance: %.4f um/N\n", 1e6 * sum / ROUNDS / POSTURES);
    std::printf("{\"name\": \"Pinocchio in C++\", \"version\": \"%s\", \"per_second\": %.1f}\n",
                PINOCCHIO_VERSION, POSTURES / seconds[ROUNDS / 2]);
}
