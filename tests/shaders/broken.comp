#include "core/shared/brdf.h"

layout(local_size_x = 1) in;
void main() {
    float x = nor_this;  // the message must name line 5, however long the include above is
}
