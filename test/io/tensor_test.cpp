#include "wordgaze/io/tensor.hpp"

#include <gtest/gtest.h>

#include "support/messages.hpp"

namespace wordgaze::io {
namespace {

TEST(Tensor, HoldsAMatrixRowByRow) {
  const Matrix<float> matrix{{1, 2, 3}, {4, 5, 6}};
  const Tensor tensor = tensor_of(matrix);
  EXPECT_EQ(tensor, (Tensor{{2, 3}, std::vector<float>{1, 2, 3, 4, 5, 6}}));
}

TEST(Tensor, HoldsAVectorInOneDimension) {
  EXPECT_EQ(tensor_of(Vector<double>{{1, 2}}), (Tensor{{2}, std::vector<double>{1, 2}}));
}

TEST(Tensor, GoesBackIntoMatrices) {
  const Matrix<float> matrix = Matrix<float>::Random(3, 4);
  const Vector<double> vector = Vector<double>::Random(5);
  TensorMap map;
  map.tensors["matrix"] = tensor_of(matrix);
  map.tensors["vector"] = tensor_of(vector);
  Matrix<float> matrix_copy(3, 4);
  Vector<double> vector_copy(5);
  copy_tensor(map, "matrix", matrix_copy);
  copy_tensor(map, "vector", vector_copy);
  EXPECT_EQ(matrix_copy, matrix);
  EXPECT_EQ(vector_copy, vector);
}

TEST(Tensor, RefusesAnotherShapeTypeOrName) {
  TensorMap map;
  map.tensors["weight"] = tensor_of(Matrix<float>::Zero(512, 128).eval());
  const auto refusal = [&](std::string_view name, auto matrix) {
    return message_of<std::runtime_error>([&] { copy_tensor(map, name, matrix); });
  };
  EXPECT_EQ(refusal("weight", Matrix<float>(256, 64)),
            "weight is F32 [512, 128], expected F32 [256, 64]");
  EXPECT_EQ(refusal("weight", Matrix<double>(512, 128)),
            "weight is F32 [512, 128], expected F64 [512, 128]");
  EXPECT_EQ(refusal("wight", Matrix<float>(512, 128)), "no tensor 'wight'");
  EXPECT_EQ(message_of<std::runtime_error>([&] { map.text("config"); }),
            "no metadata entry 'config'");
}

}  // namespace
}  // namespace wordgaze::io
