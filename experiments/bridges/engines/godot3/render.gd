extends SceneTree

# Renders a folder of `ssrlab scene-for godot` with Godot 3's screen-space reflections (README.md beside this file).
# Run by render.sh; ../shared/program.js says what it reads and writes.

const OWN_SETTINGS = ["environment"]  # of this adapter; the others are properties of Environment
# What surfaces and the background emit, and with which render modes: Godot reflects the sky, and the background's colour
# where there is none, unless ambient light is disabled.
const LIGHT = "texelFetch(light, ivec2(vec2(SCREEN_UV.x, 1.0 - SCREEN_UV.y) * size), 0).rgb"
const KINDS = {
	"depth": {"surface": "vec3(-VERTEX.z)", "background": "vec3(0.0)", "modes": ", ambient_light_disabled"},
	"off": {"surface": LIGHT, "background": LIGHT, "modes": ", ambient_light_disabled"},
	"sky": {"surface": LIGHT, "background": LIGHT, "modes": ""},
}
const TEXTURES = ["base_color", "metalness_roughness", "normal"]
const ENOUGH_DRAWS = 2  # the sky is filtered in the first

var request
var viewport
var camera
var environment = Environment.new()
var instances = {}
var materials = []  # of surfaces, then the background's
var shaders = {}    # by kind: of surfaces and of the background
var textures = {}   # by file

func _initialize():
	for argument in OS.get_cmdline_args():
		if argument.ends_with("request.json"):
			request = read_json(argument)
	var mistake = why_refused()
	if mistake != "":
		print("error: " + mistake)
		return quit(2)
	make_viewport()
	make_shaders()
	make_instances()
	make_background()
	make_sky(request["scene"]["background"])
	for view in request["scene"]["views"]:
		viewport.size = Vector2(view["width"], view["height"])
		camera.set_perspective(rad2deg(view["vertical_fov"]), view["near"], view["far"])
		for frame in view["frames"]:
			render_frame(view, frame)
	var version = Engine.get_version_info()
	write_text(request["out"] + "/done.json", JSON.print({
		"driver": VisualServer.get_video_adapter_name(),
		"version": "%d.%d.%d" % [version["major"], version["minor"], version["patch"]],
	}))
	quit(0)

func why_refused():
	if not request["scene"].has("meshes"):
		return "scene.json names no meshes as JSON: write the folder with ssrlab scene-for godot"
	if request["seeds"] > 1:
		return "Godot draws no random numbers: all seeds would be the same image; use --seeds 1"
	for view in request["scene"]["views"]:
		if not view.has("vertical_fov"):
			return view["view"] + ": this adapter knows perspective cameras alone"
	return ""

func read_text(path):
	var file = File.new()
	var code = file.open(path, File.READ)
	if code != OK:
		print("error: cannot read %s (%d)" % [path, code])
		quit(3)
	return file.get_as_text()

func read_json(path):
	return JSON.parse(read_text(path)).result

func write_text(path, text):
	var file = File.new()
	file.open(path, File.WRITE)
	file.store_string(text)
	file.close()

func in_folder(name):
	return request["folder"] + "/" + name

func make_viewport():
	viewport = Viewport.new()
	viewport.own_world = true
	viewport.usage = Viewport.USAGE_3D
	viewport.hdr = true
	viewport.keep_3d_linear = true
	viewport.msaa = Viewport.MSAA_DISABLED
	viewport.render_target_update_mode = Viewport.UPDATE_ALWAYS
	viewport.render_target_v_flip = true
	environment.ambient_light_energy = 0.0
	environment.ambient_light_sky_contribution = 0.0
	environment.background_color = Color(0, 0, 0)
	for name in request["settings"]:
		if not name in OWN_SETTINGS:
			environment.set(name, request["settings"][name])
	camera = Camera.new()
	camera.environment = environment
	viewport.add_child(camera)
	root.add_child(viewport)
	camera.current = true

func make_shaders():
	for kind in KINDS:
		shaders[kind] = []
		for of in ["surface", "background"]:
			var shader = Shader.new()
			var code = read_text("res://%s.shader" % of)
			shader.code = code.replace("/*MODES*/", KINDS[kind]["modes"]).replace("/*EMITTED*/", KINDS[kind][of])
			shaders[kind].append(shader)

func transform_of(m):
	return Transform(Vector3(m[0], m[1], m[2]), Vector3(m[4], m[5], m[6]), Vector3(m[8], m[9], m[10]), Vector3(m[12], m[13], m[14]))

func points_of(numbers):
	var points = PoolVector3Array()
	for i in range(0, numbers.size(), 3):
		points.append(Vector3(numbers[i], numbers[i + 1], numbers[i + 2]))
	return points

func mesh_of(entry):
	var uvs = PoolVector2Array()
	for i in range(0, entry["uvs"].size(), 2):
		uvs.append(Vector2(entry["uvs"][i], entry["uvs"][i + 1]))
	var indices = PoolIntArray()
	for i in range(0, entry["indices"].size(), 3):  # fronts are clockwise in Godot
		for corner in [0, 2, 1]:
			indices.append(int(entry["indices"][i + corner]))
	var arrays = []
	arrays.resize(ArrayMesh.ARRAY_MAX)
	arrays[ArrayMesh.ARRAY_VERTEX] = points_of(entry["positions"])
	arrays[ArrayMesh.ARRAY_NORMAL] = points_of(entry["normals"])
	arrays[ArrayMesh.ARRAY_TANGENT] = PoolRealArray(entry["tangents"])
	arrays[ArrayMesh.ARRAY_TEX_UV] = uvs
	arrays[ArrayMesh.ARRAY_INDEX] = indices
	if entry.has("colors"):
		var colors = PoolColorArray()
		for i in range(0, entry["colors"].size(), 4):
			colors.append(Color(entry["colors"][i], entry["colors"][i + 1], entry["colors"][i + 2], entry["colors"][i + 3]))
		arrays[ArrayMesh.ARRAY_COLOR] = colors
	var mesh = ArrayMesh.new()
	mesh.add_surface_from_arrays(Mesh.PRIMITIVE_TRIANGLES, arrays, [], 0)  # 0: nothing is compressed
	return mesh

func make_instances():
	var description = read_json(in_folder(request["scene"]["meshes"]))
	for entry in description["materials"]:
		materials.append(material_of(entry))
	var meshes = []
	for entry in description["meshes"]:
		meshes.append(mesh_of(entry))
	for name in description["nodes"]:
		var node = description["nodes"][name]
		var instance = MeshInstance.new()
		instance.mesh = meshes[node["mesh"]]
		instance.material_override = materials[node["material"]]
		viewport.add_child(instance)
		instances[name] = instance

func material_of(entry):
	var material = ShaderMaterial.new()
	material.shader = shaders["off"][0]
	var c = entry["base_color"]
	material.set_shader_param("base_color", Vector3(c[0], c[1], c[2]))
	material.set_shader_param("metalness", entry["metalness"])
	material.set_shader_param("perceptual_roughness", entry["roughness"])
	material.set_shader_param("dielectric_specular", entry["specular"])
	material.set_shader_param("normal_scale", entry["normal_scale"] if entry.has("normal_texture") else 0.0)
	material.set_shader_param("alpha_cutoff", entry.get("alpha_cutoff", 0.0))
	for name in TEXTURES:
		var slot = entry.get(name + "_texture", {"uv_from_vertex": [1, 0, 0, 0, 1, 0, 0, 0, 1]})
		var m = slot["uv_from_vertex"]
		material.set_shader_param(name + "_uv", Basis(Vector3(m[0], m[1], m[2]), Vector3(m[3], m[4], m[5]), Vector3(m[6], m[7], m[8])))
		if slot.has("file"):
			material.set_shader_param(name + "_texture", texture_of(slot["file"]))
	return material

func texture_of(name):
	if not textures.has(name):
		var image = Image.new()
		image.load(in_folder(name))
		textures[name] = ImageTexture.new()
		textures[name].create_from_image(image, Texture.FLAG_FILTER | Texture.FLAG_REPEAT)  # no mipmaps, as ssrlab
	return textures[name]

func float_texture(name, width, height, flags):
	var file = File.new()
	file.open(in_folder(name), File.READ)
	var image = Image.new()
	image.create_from_data(width, height, false, Image.FORMAT_RGBF, file.get_buffer(file.get_len()))
	var texture = ImageTexture.new()
	texture.create_from_image(image, flags)
	return texture

func make_background():
	var quad = MeshInstance.new()
	quad.mesh = QuadMesh.new()
	quad.mesh.size = Vector2(2, 2)
	quad.extra_cull_margin = 16384
	materials.append(ShaderMaterial.new())
	quad.material_override = materials[-1]
	viewport.add_child(quad)

func make_sky(background):
	var sky = PanoramaSky.new()
	if background.has("color"):
		var image = Image.new()
		var c = background["color"]
		image.create(16, 8, false, Image.FORMAT_RGBF)
		image.fill(Color(c[0], c[1], c[2]))
		var texture = ImageTexture.new()
		texture.create_from_image(image, Texture.FLAG_FILTER)
		sky.panorama = texture
	else:
		sky.panorama = float_texture(background["raw"], background["width"], background["height"], Texture.FLAG_FILTER)
		# Godot's panorama begins a quarter turn from scene.json's.
		environment.background_sky_rotation = Vector3(0, PI / 2 + background["rotation"], 0)
	environment.background_sky = sky

func render_frame(view, frame):
	camera.transform = transform_of(frame["world_from_camera"])
	camera.force_update_transform()  # else transforms are handed on when a frame of the main loop ends
	for name in frame["nodes"]:
		instances[name].transform = transform_of(frame["nodes"][name])
		instances[name].force_update_transform()
	var light = float_texture(frame["light_raw"], view["width"], view["height"], 0)  # nearest
	for material in materials:
		material.set_shader_param("light", light)
		material.set_shader_param("size", viewport.size)
	environment.background_mode = Environment.BG_COLOR
	environment.ss_reflections_enabled = false
	write_image(view, frame, "depth", "depth", Image.FORMAT_RF)
	write_image(view, frame, "off", "off", Image.FORMAT_RGBF)
	environment.ss_reflections_enabled = true
	if request["settings"]["environment"]:
		environment.background_mode = Environment.BG_COLOR_SKY
		write_image(view, frame, "s0", "sky", Image.FORMAT_RGBF)
	else:
		write_image(view, frame, "s0", "off", Image.FORMAT_RGBF)

func write_image(view, frame, what, kind, format):
	for i in range(materials.size()):
		materials[i].shader = shaders[kind][1 if i == materials.size() - 1 else 0]
	for i in range(ENOUGH_DRAWS):
		VisualServer.force_draw(false)
	var image = viewport.get_texture().get_data()
	image.convert(format)
	var file = File.new()
	file.open("%s/%s/f%d.%s.f32" % [request["out"], view["view"], frame["frame"], what], File.WRITE)
	file.store_buffer(image.get_data())
	file.close()
