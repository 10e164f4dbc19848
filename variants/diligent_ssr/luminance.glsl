// Of gamma-encoded television (ITU-R BT.601); the original weights linear colours with it.
float luminance(vec3 color) { return dot(color, vec3(0.299, 0.587, 0.114)); }
